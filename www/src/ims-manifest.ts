// What a learning system asks for of a SCORM 1.2 package: what is in it, and what to start.

export interface Packaged {
  /** Of the package, unique in a course: letters, digits and dashes. */
  identifier: string
  title: string
  /** The page to start, and all files, itself among them. */
  start: string
  files: string[]
  /** Points of a hundred from which on it is passed. */
  mastery?: number
}

const escape = (text: string) => text.replace(/[&"<>]/g, character => `&#${character.charCodeAt(0)};`)

export const imsManifest = ({ identifier, title, start, files, mastery }: Packaged): string => `<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier="${identifier}" version="1.0" xmlns="http://www.imsproject.org/xsd/imscp_rootv1p1p2" xmlns:adlcp="http://www.adlnet.org/xsd/adlcp_rootv1p2">
  <metadata>
    <schema>ADL SCORM</schema>
    <schemaversion>1.2</schemaversion>
  </metadata>
  <organizations default="fastslam">
    <organization identifier="fastslam">
      <title>${escape(title)}</title>
      <item identifier="figure" identifierref="page">
        <title>${escape(title)}</title>${mastery === undefined ? '' : `\n        <adlcp:masteryscore>${mastery}</adlcp:masteryscore>`}
      </item>
    </organization>
  </organizations>
  <resources>
    <resource identifier="page" type="webcontent" adlcp:scormtype="sco" href="${start}">
${files.map(file => `      <file href="${escape(file)}" />`).join('\n')}
    </resource>
  </resources>
</manifest>
`
